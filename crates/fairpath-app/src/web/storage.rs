//! Texts that stay from one visit to the next, in the browser's database, which holds many megabytes; its simpler store holds five.

use idb::{Database, Factory, ObjectStoreParams, TransactionMode};
use thiserror::Error;
use wasm_bindgen::JsValue;

/// The database's name.
const DATABASE: &str = "fairpath";

/// The version of what is in it; the next one that differs must bring over what it finds.
const VERSION: u32 = 1;

/// The only table: texts by key.
const TEXTS: &str = "texts";

/// Why the browser did not do as it was asked.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum StorageError {
    /// Saving failed; what was saved before is still there.
    #[error(
        "the browser could not save {key} ({reason}): free some space or save to a file, and mind that private windows forget all"
    )]
    Save {
        /// What was to be saved.
        key: String,
        /// What the browser says.
        reason: String,
    },
    /// Loading failed.
    #[error("the browser could not load {key} ({reason}): allow this page to store data, then reload it")]
    Load {
        /// What was to be loaded.
        key: String,
        /// What the browser says.
        reason: String,
    },
    /// Removing failed.
    #[error("the browser could not remove {key} ({reason}): clear this page's data in the browser's settings")]
    Remove {
        /// What was to be removed.
        key: String,
        /// What the browser says.
        reason: String,
    },
}

/// Saves a text under a key, in place of what was there. Calls take effect in their order.
///
/// # Errors
/// When the browser has no space or keeps nothing; what was saved before is still there then.
pub async fn save(key: &str, text: &str) -> Result<(), StorageError> {
    let saved = async {
        let database = open().await?;
        let transaction = database.transaction(&[TEXTS], TransactionMode::ReadWrite)?;
        transaction.object_store(TEXTS)?.put(&JsValue::from_str(text), Some(&JsValue::from_str(key)))?.await?;
        // Only now is it said whether there was space.
        transaction.commit()?.await?;
        database.close();
        Ok(())
    };
    saved.await.map_err(|reason: idb::Error| StorageError::Save { key: key.into(), reason: reason.to_string() })
}

/// The text under a key, if there is one.
///
/// # Errors
/// When the browser gives no access, or what is there is no text.
pub async fn load(key: &str) -> Result<Option<String>, StorageError> {
    let loaded = async {
        let database = open().await?;
        let transaction = database.transaction(&[TEXTS], TransactionMode::ReadOnly)?;
        let found = transaction.object_store(TEXTS)?.get(JsValue::from_str(key))?.await?;
        database.close();
        Ok(found)
    };
    let fault = |reason: String| StorageError::Load { key: key.into(), reason };
    let found: Option<JsValue> = loaded.await.map_err(|reason: idb::Error| fault(reason.to_string()))?;
    found.map(|value| value.as_string().ok_or_else(|| fault("what is there is no text".into()))).transpose()
}

/// Removes the text under a key, if there is one.
///
/// # Errors
/// When the browser gives no access.
pub async fn remove(key: &str) -> Result<(), StorageError> {
    let removed = async {
        let database = open().await?;
        let transaction = database.transaction(&[TEXTS], TransactionMode::ReadWrite)?;
        transaction.object_store(TEXTS)?.delete(JsValue::from_str(key))?.await?;
        transaction.commit()?.await?;
        database.close();
        Ok(())
    };
    removed.await.map_err(|reason: idb::Error| StorageError::Remove { key: key.into(), reason: reason.to_string() })
}

async fn open() -> Result<Database, idb::Error> {
    let mut request = Factory::new()?.open(DATABASE, Some(VERSION))?;
    request.on_upgrade_needed(|event| {
        // Where this fails the table is missing, which the first transaction says.
        if let Ok(database) = idb::event::DatabaseEvent::database(&event) {
            let _ = database.create_object_store(TEXTS, ObjectStoreParams::new());
        }
    });
    request.await
}
