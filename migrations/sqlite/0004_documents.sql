-- JSON columns hold documents that name their version, apart from what the API shows (src/store/documents). Rows stay as
-- they are: a document without a version is version 0 and upgraded when it is read. This step only raises the schema, so
-- that a build which does not know versions refuses the database instead of failing at its first document.
SELECT 1;
